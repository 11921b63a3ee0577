"""python_api.py: Markdown page of the Python package, from its signatures and docstrings."""
import ast
import inspect
import pathlib
import re

# Sections: title, module, names in order; None: every name that no other section lists
SECTIONS = (
    ('Devices, scenes and renderers', 'firn',
     ('Device', 'Scene', 'Objects', 'SceneObject', 'Material', 'Renderer', 'Plan')),
    ('Cameras and frames', 'firn', ('Camera', 'Frame', 'diff', 'write_exr')),
    ('Names and version', 'firn', ('layers', 'settings', 'version')),
    ('Exceptions', 'firn', None),
    ('Data sets', 'firn.dataset', None),
)
# Classes whose constructor is documented. Objects of other classes are returned by methods.
CONSTRUCTED = ('Device', 'Material', 'Plan', 'Camera', 'Writer')


def definitions(path):
    """Returns {name: node} of a file's classes and functions."""
    tree = ast.parse(path.read_text('utf-8'))
    return {node.name: node for node in tree.body
            if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def prose(node):
    """Returns a docstring as Markdown; paragraphs in columns become code blocks."""
    text = inspect.cleandoc(ast.get_docstring(node) or '')
    paragraphs = re.split(r'\n{2,}', text)
    return '\n\n'.join(f'```text\n{p}\n```' if re.search(r'\S {3,}\S', p) else p
                       for p in paragraphs)


def signature(node, prefix, is_method):
    """Returns the declaration as a call, without self or cls."""
    arguments = node.args
    if is_method and not any(ast.unparse(d) == 'staticmethod' for d in node.decorator_list):
        first = arguments.posonlyargs or arguments.args
        first.pop(0)
    returns = f' -> {ast.unparse(node.returns)}' if node.returns else ''
    return f'{prefix}{node.name}({ast.unparse(arguments)}){returns}'


def members(node, name):
    """Yields (declaration, text) of a class's public and documented members."""
    for child in node.body:
        if not isinstance(child, ast.FunctionDef) or child.name.startswith('_'):
            continue
        decorators = [ast.unparse(d) for d in child.decorator_list]
        if any(d.endswith('.setter') for d in decorators):
            continue
        if 'property' in decorators:
            returns = f': {ast.unparse(child.returns)}' if child.returns else ''
            yield f'{name}.{child.name}{returns}', prose(child)
        else:
            yield signature(child, f'{name}.', True), prose(child)


def entry(module, node):
    """Returns the Markdown of a class or function."""
    name = f'{module}.{node.name}'
    text = f'### {name}\n\n'
    if isinstance(node, ast.FunctionDef):
        return text + f'```python\n{signature(node, module + ".", False)}\n```\n\n{prose(node)}\n\n'
    start = next((n for n in node.body if getattr(n, 'name', '') == '__init__'), None)
    if start and node.name in CONSTRUCTED:
        call = signature(start, '', True).removeprefix('__init__')
        text += f'```python\n{name}{call}\n```\n\n'
    text += prose(node) + '\n\n'
    for declaration, what in members(node, node.name):
        text += f'```python\n{declaration}\n```\n\n{what}\n\n'
    return text


def page(root):
    """Returns the page for the source tree `root`."""
    package = pathlib.Path(root) / 'python/firn'
    known = {}
    for path in sorted(package.glob('*.py')):
        known.update(definitions(path))
    top = ast.parse((package / '__init__.py').read_text('utf-8'))
    exported = next(ast.literal_eval(node.value) for node in top.body
                    if isinstance(node, ast.Assign) and node.targets[0].id == '__all__')
    sets = definitions(package / 'dataset.py')
    rest = {'firn': exported,
            'firn.dataset': [*(n for n in sets if not n.startswith('_')), 'tabletop']}
    text = '# Python: firn and firn.dataset\n\n' + prose(top) + '\n\n'
    for title, module, names in SECTIONS:
        listed = [n for _, m, ns in SECTIONS if m == module for n in ns or ()]
        shown = names or [n for n in rest[module] if n not in listed and n in known]
        text += f'## {title}\n\n' + ''.join(entry(module, known[n]) for n in shown)
    return text
