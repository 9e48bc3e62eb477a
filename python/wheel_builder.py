"""Builds the wheel for `pip install .` by CMake; needs no other package (PEP 517). The packages of tools/packages.sh must be there.
`--config-settings=build=FOLDER` takes a build folder that exists instead of build/wheel."""
import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import sysconfig
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
TEXT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
NAME, VERSION, SUMMARY, PYTHON = (re.search(rf'^{key} = "(.+)"$', TEXT, re.M)[1] for key in ("name", "version", "description", "requires-python"))


def _build(settings):
    """Builds the module and the program, and returns the build folder."""
    given = (settings or {}).get("build")
    folder = pathlib.Path(given).resolve() if given else ROOT / "build" / "wheel"
    if not given:
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DSINEW_BUILD_APPS=ON",
                        "-DSINEW_BUILD_TESTS=OFF", "-DSINEW_BENCH_NATIVE=OFF", "-DSINEW_BUILD_PYTHON=ON",
                        f"-DSINEW_PYTHON={getattr(sys, '_base_executable', sys.executable)}"], check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", folder, "--target", "sinew_python", "sinew_cli"], check=True, stdout=sys.stderr)
    return folder


def _metadata():
    return f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {VERSION}\nSummary: {SUMMARY}\nRequires-Python: {PYTHON}\nRequires-Dist: numpy\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = _build(config_settings)
    package = build / "python" / "sinew"
    module = package / f"_sinew{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not module.exists():
        raise SystemExit(f"{module} is not there: was the module built for another Python?")
    files = {f"sinew/{path.name}": path.read_bytes()
             for path in sorted(package.iterdir()) if path.suffix in (".py", ".pyi", ".typed") or path == module}
    files["sinew/bin/sinew"] = (build / "bin" / "sinew").read_bytes()
    tag = "-".join((f"cp{sys.version_info[0]}{sys.version_info[1]}",) * 2 + (re.sub(r"[-.]", "_", sysconfig.get_platform()),))
    info = f"{NAME}-{VERSION}.dist-info"
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: sinew\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = "".join(f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}\n"
                     for name, data in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"{NAME}-{VERSION}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100755 if name.startswith("sinew/bin/") else 0o100644) << 16  # pip asks for a regular file
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return wheel
