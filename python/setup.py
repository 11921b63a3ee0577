"""setup.py: builds the wheel in a folder that make_wheel.py has filled with all files."""
from pathlib import Path

from setuptools import Distribution, setup
from wheel.bdist_wheel import bdist_wheel


class BinaryDistribution(Distribution):
    """Marks the wheel as platform-specific, because it contains a shared library."""
    def has_ext_modules(self):
        return True


class AnyPython(bdist_wheel):
    """Tags the wheel for all versions of Python 3, because ctypes loads the library."""
    def get_tag(self):
        return 'py3', 'none', super().get_tag()[2]


setup(
    name='firn',
    version=Path('VERSION').read_text().strip(),
    description='Renders ice, glass and water, with exact depth, normals, masks and flow',
    license='MIT',
    packages=['firn'],
    package_data={'firn': ['libfirn.so.0', 'firn-reader', 'py.typed', 'assets/*']},
    install_requires=['numpy>=1.20'],
    python_requires='>=3.9',
    distclass=BinaryDistribution,
    cmdclass={'bdist_wheel': AnyPython},
    zip_safe=False,
)
