"""The front end that is shipped is the one of web/: its digest is that of all sources, as web/vite.config.ts takes it."""

import hashlib
from importlib.resources import files
from pathlib import Path

import freebody.views.report

WEB = Path(__file__).parents[2] / "web"


def test_the_bundle_is_current():
    sources = [path for path in (WEB / "src").rglob("*") if path.is_file()]
    names = sorted(path.relative_to(WEB).as_posix() for path in [*sources, WEB / "package-lock.json", WEB / "vite.config.ts"])
    digest = hashlib.sha256(b"".join(name.encode() + b"\0" + (WEB / name).read_bytes() + b"\0" for name in names)).hexdigest()
    bundle = files(freebody.views.report).joinpath("bundle", "report.js").read_text(encoding="utf-8")
    assert bundle.startswith(f"/* sources {digest} */"), "web/ has changed: ./dev web"
