"""The compiled part of the wheel. CMake builds it (preset release); WRLKIT_PACKAGE names a folder python/ that was built already."""
import os
import pathlib
import re
import shutil
import subprocess

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class Build(build_ext):
    """The module, the codecs beside it, and the types that were made of both."""

    def run(self):
        package = os.environ.get('WRLKIT_PACKAGE')
        if not package:
            subprocess.run(['cmake', '--preset', 'release'], cwd=ROOT, check=True)
            subprocess.run(['cmake', '--build', ROOT / 'build/release', '--target', 'python_package'], check=True)
            package = ROOT / 'build/release/python'
        target = pathlib.Path(self.build_lib) / 'wrlkit'
        target.mkdir(parents=True, exist_ok=True)
        for path in pathlib.Path(package, 'wrlkit').iterdir():
            if path.suffix in ('.so', '.pyi', '.typed'):
                shutil.copy2(path, target)


VERSION = re.search(r'project\(wrlkit VERSION ([\d.]+)', (ROOT / 'CMakeLists.txt').read_text())[1]
setup(version=VERSION, ext_modules=[Extension('wrlkit._wrlkit', [])], cmdclass={'build_ext': Build})
