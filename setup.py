"""The compiled part of the wheel. CMake builds it for the Python that runs this; WRLKIT_PACKAGE names a folder python/ that was built already."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class Build(build_ext):
    """The module, the codecs and the process of Scripts next to it, and the types that were made of both."""

    def run(self):
        package = os.environ.get('WRLKIT_PACKAGE')
        if not package:
            build = ROOT / 'build/wheel'
            options = ['-DWRLKIT_TESTS=OFF', f'-DWRLKIT_PYTHON_EXECUTABLE={sys.executable}']
            subprocess.run(['cmake', '--preset', 'release', '-B', build, *options], cwd=ROOT, check=True)
            subprocess.run(['cmake', '--build', build, '--target', 'python_package'], check=True)
            package = build / 'python'
        target = pathlib.Path(self.build_lib) / 'wrlkit'
        target.mkdir(parents=True, exist_ok=True)
        for path in pathlib.Path(package, 'wrlkit').iterdir():
            if path.suffix in ('.so', '.pyi', '.typed') or path.name == 'wrlkit_script':
                shutil.copy2(path, target)


VERSION = re.search(r'project\(wrlkit VERSION ([\d.]+)', (ROOT / 'CMakeLists.txt').read_text())[1]
setup(version=VERSION, ext_modules=[Extension('wrlkit._wrlkit', [])], cmdclass={'build_ext': Build})
