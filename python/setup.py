"""setup.py: the wheel of firn. make_wheel.py calls it in a folder with libfirn and its reader."""
from pathlib import Path

from setuptools import Distribution, setup
from wheel.bdist_wheel import bdist_wheel


class BinaryDistribution(Distribution):
    """Has a library, so that it is installed where platforms differ."""
    def has_ext_modules(self):
        return True


class AnyPython(bdist_wheel):
    """The library is loaded by ctypes: one wheel serves every Python 3."""
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
