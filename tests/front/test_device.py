"""test_device.py: tests firn with failing Vulkan calls: every call fails in turn.

Usage: see case.py. FAIL_LAYER in the environment is the folder of fail_layer.json, the manifest of
tests/support/fail_vulkan_layer.c. FAIL_SAMPLE=1: only the first, middle and last call of each
command, for
slow builds with sanitizers.
"""
import collections
import concurrent.futures
import functools
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DEVICE, PLAIN, Case, long, main, unsanitized  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAYER = ROOT / 'tests/support/fail_vulkan_layer.c'
REGISTRY = pathlib.Path('/usr/share/vulkan/registry/vk.xml')
FAILED, TRY_AGAIN = 1, 75
PARTS = 8  # of all faults
EVERY_OTHER = range(0, PARTS, 2)  # each call, for most can fail in two ways
OLDER = b'what was there before'

# What a result that Vulkan allows a command makes of the exit code.
CODES = {
    'VK_TIMEOUT': TRY_AGAIN,
    'VK_ERROR_OUT_OF_HOST_MEMORY': TRY_AGAIN,
    'VK_ERROR_OUT_OF_DEVICE_MEMORY': TRY_AGAIN,
    'VK_ERROR_DEVICE_LOST': TRY_AGAIN,
    'VK_ERROR_MEMORY_MAP_FAILED': TRY_AGAIN,
    'VK_ERROR_OUT_OF_POOL_MEMORY': TRY_AGAIN,
    'VK_ERROR_FRAGMENTED_POOL': TRY_AGAIN,
    'VK_ERROR_FRAGMENTATION': TRY_AGAIN,
    'VK_ERROR_TOO_MANY_OBJECTS': TRY_AGAIN,
    'VK_ERROR_INITIALIZATION_FAILED': NO_DEVICE,
    'VK_ERROR_INCOMPATIBLE_DRIVER': NO_DEVICE,
    'VK_ERROR_FORMAT_NOT_SUPPORTED': NO_DEVICE,
    'VK_ERROR_SURFACE_LOST_KHR': TRY_AGAIN,
    'VK_ERROR_NATIVE_WINDOW_IN_USE_KHR': FAILED,
    'VK_ERROR_OUT_OF_DATE_KHR': 0,
    'VK_ERROR_EXTENSION_NOT_PRESENT': FAILED,
    'VK_ERROR_FEATURE_NOT_PRESENT': FAILED,
}
# Commands without which the picture is as good: then nothing is said, and the bytes are the same.
# Of vkMapMemory these are the calls that only choose a size of pages.
NEEDLESS = ('vkDeviceWaitIdle', 'vkGetPipelineCacheData', 'vkCreatePipelineCache', 'vkMapMemory')
# What fails here is not for one pass, image or buffer.
NAMELESS = ('vkCreateInstance', 'vkCreateDevice', 'vkCreatePipelineCache', 'vkCreateCommandPool',
            'vkEnumeratePhysicalDevices', 'vkEnumerateDeviceExtensionProperties')
# The same: what they are for is the one window.
WINDOW = ('vkAcquireNextImageKHR', 'vkCreateSemaphore', 'vkCreateSwapchainKHR',
          'vkGetPhysicalDeviceSurfaceCapabilitiesKHR', 'vkGetPhysicalDeviceSurfaceFormatsKHR',
          'vkGetPhysicalDeviceSurfacePresentModesKHR', 'vkGetSwapchainImagesKHR',
          'vkQueuePresentKHR')
# Answered by the loader above every layer.
LOADERS = {'vkEnumerateInstanceExtensionProperties', 'vkSetDebugUtilsObjectNameEXT',
           'vkCreateDebugUtilsMessengerEXT'}
# What the graph can do, and nothing that firn draws makes it do.
GRAPHS_ALONE = {'vkCreateAccelerationStructureKHR', 'vkQueueWaitIdle'}

# Every kind of call is among those of an empty sphere.
SMALL = ('--size', '32x24', *PLAIN, '--background', '0.4,0.5,0.6', '-o', 'a.exr')
Fault = collections.namedtuple('Fault', 'command call result')


@functools.cache
def registry():
    """{command: the names of the results that are no success, of those in CODES}, {name: value}"""
    tree = xml.etree.ElementTree.parse(REGISTRY)
    values = {row.get('name'): int(row.get('value')) for row in tree.iter('enum')
              if row.get('name') in CODES and row.get('value')}
    for extension in (*tree.iter('feature'), *tree.iter('extension')):
        for row in extension.iter('enum'):
            number = row.get('extnumber', extension.get('number'))
            if row.get('name') in CODES and row.get('offset'):
                value = 1000000000 + (int(number) - 1) * 1000 + int(row.get('offset'))
                values[row.get('name')] = -value if row.get('dir') == '-' else value
    assert set(values) == set(CODES), set(CODES) - set(values)
    commands = {}
    for row in tree.iter('command'):
        name = row.findtext('proto/name')
        results = f"{row.get('successcodes', '')},{row.get('errorcodes', '')}".split(',')
        if name and row.get('errorcodes'):
            commands[name] = [result for result in results if result in values]
    return commands, values


def choose(counts, sample, without):
    """Every call once, with one result after the other; first, middle and last call with all."""
    commands, _ = registry()
    for command, count in counts.items():
        results = [result for result in commands[command] if result not in without]
        of_all = {1, (count + 1) // 2, count}
        for call in range(1, count + 1):
            if call in of_all:
                yield from (Fault(command, call, result) for result in results)
            elif not sample:
                yield Fault(command, call, results[call % len(results)])


class LayerCase(Case):
    output = 'a.exr'  # that the swept commands write
    without = ()      # results that are not swept

    def setUp(self):
        super().setUp()
        self.env = {
            'VK_ADD_LAYER_PATH': os.environ['FAIL_LAYER'],
            'VK_INSTANCE_LAYERS': 'VK_LAYER_FIRN_fail',
            'NODEVICE_SELECT': '1',  # a layer of the driver's that trusts every result
            'XDG_CACHE_HOME': str(self.folder / 'cache'),
        }

    def count(self, *arguments, **env):
        """How often each command is called, once the caches are warm."""
        for _ in range(2):
            self.succeed(*arguments, env={**self.env, 'FAIL_COUNT': 'counts', **env})
        lines = (self.folder / 'counts').read_text().splitlines()
        return {name: int(count) for name, count in map(str.split, lines)}

    def run_with(self, arguments, fault):
        """What it says, its code, and what it leaves: {name: bytes}."""
        _, values = registry()
        env = {**self.env, 'FAIL_CALL': fault.command, 'FAIL_AT': fault.call,
               'FAIL_RESULT': values[fault.result]}
        with tempfile.TemporaryDirectory(prefix='firn ') as folder:
            (pathlib.Path(folder) / self.output).write_bytes(OLDER)
            try:
                done = self.firn(*arguments, cwd=folder,
                                 env={name: str(value) for name, value in env.items()})
            except subprocess.TimeoutExpired:
                return fault, 'hangs', None, {}
            left = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
        return fault, done.stderr.decode(), done.returncode, left

    def check(self, fault, words, code, left, picture):
        lines = words.splitlines()
        self.assertIn(f'fail_layer: {fault.command} {fault.call}', lines)
        lines = [line for line in lines if not line.startswith('fail_layer: ')]
        if code == 0:
            if CODES[fault.result]:
                self.assertIn(fault.command, NEEDLESS)
            self.assertEqual(lines, [])
            self.assertEqual(left, {self.output: picture})
            return
        self.assertEqual(code, CODES[fault.result])
        self.assertEqual(len(lines), 1)
        self.assertTrue(lines[0].startswith('firn: '))
        self.assertEqual(left, {self.output: OLDER})
        if code != NO_DEVICE:
            self.assertIn(fault.result, lines[0])
            if fault.command not in NAMELESS + WINDOW:
                self.assertRegex(lines[0], rf'\b{fault.command} of [a-z]')

    def sweep(self, *arguments, only=None, sample=os.environ.get('FAIL_SAMPLE') == '1',
              most=None, parts=range(PARTS)):
        """
        `most`: of calls whose number depends on how long something takes; `parts`: which of the
        faults.
        """
        arguments = (*arguments, '-q')
        counts = {name: min(count, most or count) for name, count in self.count(*arguments).items()
                  if not only or name in only}
        self.assertEqual(set(counts), set(only or counts), 'calls that are not made')
        written = self.folder / self.output
        picture = written.read_bytes() if written.exists() else OLDER
        faults = [fault for i, fault in enumerate(choose(counts, sample, self.without))
                  if i % PARTS in parts]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            ends = list(pool.map(functools.partial(self.run_with, arguments), faults))
        for fault, words, code, left in ends:
            with self.subTest(f'{fault}: {code}: {words}'):
                self.check(fault, words, code, left, picture)
        cache = self.folder / 'cache/firn'
        self.assertEqual(len(list(cache.iterdir())), 1)  # no temporaries
        print(f"{' '.join(arguments[:2])}: {len(counts)} commands, {sum(counts.values())} calls, "
              f'{len(faults)} pairs of call and result', file=sys.stderr)
        for name in counts:
            codes = collections.Counter(code for fault, _, code, _ in ends if fault.command == name)
            print(f'  {name}: {counts[name]} calls, exit codes {dict(codes)}', file=sys.stderr)


class Device(LayerCase):
    def test_every_command_is_in_the_layer(self):
        """What the sources call and Vulkan lets fail: a new one must be swept, too."""
        commands, _ = registry()
        in_layer = set(re.findall(r'row\((\w+),', LAYER.read_text()))
        in_layer = {f'vk{name}' for name in (*in_layer, 'CreateInstance', 'CreateDevice')}
        called = set()
        for folder in ('graph', 'src'):
            for path in (ROOT / folder).rglob('*.[ch]'):
                text = path.read_text()
                called.update(re.findall(r'\bvk[A-Z]\w+(?=\()', text))
                if path.name == 'vulkan_functions.h':
                    called.update(f'vk{name}' for name in re.findall(r'row\((\w+)\)', text))
        self.assertGreater(len(called & in_layer), 40)
        self.assertEqual((called & set(commands)) - in_layer - LOADERS - GRAPHS_ALONE, set())

    def test_render_every_eighth_fault(self):
        self.sweep('render', 'sphere', *SMALL, parts=(0,))

    @long
    def test_render_the_others(self):
        self.sweep('render', 'sphere', *SMALL, parts=range(1, PARTS))

    def test_compute(self):
        self.sweep('render', 'pool', *SMALL, only=('vkCreateComputePipelines',))

    @unsanitized
    def test_validated(self):
        """Nothing that the device still uses may be freed, nor anything be left: the layer tells.
        Only under validation there are render passes."""
        self.sweep('render', 'sphere', *SMALL, '--validate', sample=True, parts=EVERY_OTHER,
                   only=('vkAllocateMemory', 'vkCreateImageView', 'vkCreateRenderPass',
                         'vkCreateFramebuffer', 'vkQueueSubmit2', 'vkWaitForFences'))

    @long
    def test_measured(self):
        self.sweep('profile', 'sphere', '--size', '32x24', *PLAIN, '--runs', '2', '--warmup', '1',
                   '--clock', 'submits', sample=True, most=2,
                   only=('vkCreateQueryPool', 'vkGetQueryPoolResults'))


if __name__ == '__main__':
    main()
