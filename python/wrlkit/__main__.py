"""The command line of wrlkit, in Python: python3 -m wrlkit convert plant.wrl plant.glb. The program becomes this when a recipe names
files in Python."""
import faulthandler
import signal
import sys

from ._wrlkit import _main


def run():
    """Ends the process with the exit code of the verb."""
    for name in (signal.SIGINT, signal.SIGPIPE):
        signal.signal(name, signal.SIG_DFL)  # as in every other program
    faulthandler.enable()                    # a pass that crashes prints where
    sys.dont_write_bytecode = True
    sys.stdout = sys.stderr                  # what verbs print is data
    sys.exit(_main(sys.argv[1:]))


if __name__ == '__main__':
    run()
