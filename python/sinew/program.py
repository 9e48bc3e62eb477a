"""The commands of the program `sinew`, which run in a process of their own: its signals, forks and faults stay there."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

from ._sinew import Error, Scene


def program():
    """Path of the program: SINEW_PROGRAM of the environment, the one of the package, that of the build, or that of PATH."""
    folder = pathlib.Path(__file__).parent
    built = folder / "program_path.txt"
    candidates = [os.environ.get("SINEW_PROGRAM"), folder / "bin" / "sinew",
                  built.read_text(encoding="utf-8").strip() if built.exists() else None, shutil.which("sinew")]
    for candidate in candidates:
        if candidate and os.access(candidate, os.X_OK):
            return str(candidate)
    raise Error("the program sinew is not there: set SINEW_PROGRAM to its path")


def _call(arguments):
    result = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if result.returncode != 0:
        error = Error(result.stderr.strip() or f"sinew ended with {result.returncode}")
        error.result = f"exit code {result.returncode}"
        raise error
    return result.stdout


def _options(options):
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            yield option
        elif value is not None and value is not False:
            yield from (option, value)


def run(scene, frames=240, **options):
    """Runs a scene file or mesh and returns the report (docs/report.md). Options are those of `sinew run`: substeps=16."""
    return json.loads(_call(["run", scene, "--frames", frames, "--json", "-", *_options(options)]))


def describe(scene, settings=None):
    """The passes, buffers and barriers of a step, as text, of a Scene or of a file."""
    return scene.describe(settings) if isinstance(scene, Scene) else Scene(os.fspath(scene)).describe(settings)


def study(scene, out=None, **options):
    """Measures speed against error of every solver and returns the report. Options are those of `sinew study`. `out` keeps its
    folder, with plots."""
    with tempfile.TemporaryDirectory() as folder:
        target = pathlib.Path(out if out is not None else folder)
        _call(["study", "--scene", scene, "--out", target, *_options(options)])
        return json.loads((target / "study.json").read_text(encoding="utf-8"))
