"""The front end by its own tests, in web/tests: its logic in Node, and reports in a browser."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from freebody import Mechanism
from freebody.views.report import write_report

ROOT = Path(__file__).parents[2]
REPORTS = {
    **{name: ROOT / "examples" / f"{name}.yaml" for name in ("four_bar", "new_gun", "tossed_box")},
    "pulleys": ROOT / "systems" / "19.3.20-guide-and-pendulum" / "pulleys.yaml",
    "walker": ROOT / "systems" / "GEN-STEP-one-foot" / "model.yaml",
    "car": ROOT / "systems" / "GEN-SUSP-suspensions" / "half.yaml",
}


@pytest.mark.long
def test_the_front_end(tmp_path):
    for name, model in REPORTS.items():
        page = write_report(Mechanism.load(model).simulate(), tmp_path / f"{name}.html")
        assert page.stat().st_size < 1_000_000
    in_browser(FREEBODY_REPORTS=str(tmp_path))


def in_browser(*tests: str, **places: str) -> None:
    """Tests of web/tests pass, in a browser where they need one; ``places`` are where they find what they look at."""
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))
    subprocess.run(["npm", "ci", "--silent"], cwd=ROOT / "web", check=True)
    seen = os.environ | {"FREEBODY_CHROMIUM": browser, **places}
    done = subprocess.run(["npm", "test", "--", *tests], cwd=ROOT / "web", env=seen, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
