"""Saved and loaded again: every number, the model, and what cannot be known from a file."""

import re
import sys

import numpy as np
import pytest

import freebody as fb
from freebody.run.simulation import Run
from freebody.views.compare import compare


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_a_run_comes_back_to_the_last_bit(suffix, four_bar, tmp_path):
    back = Run.load(four_bar.save(tmp_path / f"run{suffix}"))
    assert (back.t == four_bar.t).all()
    for kind, block in four_bar.blocks.items():
        assert np.array_equal(back.blocks[kind], block, equal_nan=True), kind
    for part in ("columns", "events", "outcome", "report", "settings", "stats"):
        assert getattr(back, part) == getattr(four_bar, part), part
    assert back.source.model == four_bar.source.model and back.source.report == four_bar.source.report
    assert np.array_equal(back.end.q, four_bar.end.q) and np.array_equal(back.start.u, four_bar.start.u)


def test_a_path_in_mm_is_the_place_over_time_and_closes_where_the_motion_comes_back(tmp_path):
    """A crank turns once a second: its end goes round a circle of 0.4 m, which is as large on paper, with y upwards."""
    crank = fb.Mechanism("crank")
    arm = crank.rod("arm", length=0.4, mass=1)
    crank.hinge(crank.ground.O, arm.start, coordinate="theta", name="pivot")
    crank.motion("turn", "theta", "2*pi*t")
    run = crank.simulate(until=1)
    page = run.save(tmp_path / "path.svg", "arm.end").read_text()
    places = np.array([[float(x) for x in place.split(",")] for place in re.search(r'd="M(.*) Z"', page)[1].split()])
    assert np.hypot(*places.T) == pytest.approx(400, rel=1e-5) and places[1, 1] < 0 and len(places) == len(run.t) - 1
    size = re.search(r'width="(.*?)mm" height="(.*?)mm" viewBox="(.*?) (.*?) (.*?) (.*?)"', page).groups()
    width, *others = map(float, size)
    assert width > 800 and others == pytest.approx([width, -width / 2, -width / 2, width, width], rel=1e-5)  # six figures
    with pytest.raises(ValueError, match=r"pivot.F is none: write a \.csv"):
        run.save(tmp_path / "path.svg", "pivot.F")


def test_a_loaded_run_says_what_it_does_not_know(four_bar, tmp_path):
    back = Run.load(four_bar.save(tmp_path / "run.csv"))
    assert back["theta"][0] == four_bar["theta"][0] and (back["coupler.P"] == four_bar["coupler.P"]).all()
    with pytest.raises(LookupError, match="again"):
        back.evaluate("theta", 0.12345)
    with pytest.raises(LookupError, match="was not saved"):
        _ = back["2*theta"]
    assert back.again()["2*theta"] == pytest.approx(2 * four_bar["theta"])


def test_a_loaded_run_goes_on(four_bar, tmp_path):
    back = Run.load(four_bar.save(tmp_path / "run.nc"))
    assert back.continue_(3.2).t[-1] == 3.2


def test_indeterminate_stays_indeterminate(indeterminate, tmp_path):
    back = Run.load(indeterminate.save(tmp_path / "run.nc"))
    assert not back.reactions["knee"].determinate
    assert back.reactions["knee"].least.Fx == pytest.approx(indeterminate.reactions["knee"].least.Fx)


def test_tables_of_other_libraries(four_bar):
    data, table = four_bar.to_xarray(), four_bar.to_pandas()
    chosen = data["reaction"].sel(joint="crank pin", part="Fx")
    assert (chosen.values == four_bar.reactions["crank pin"].Fx).all() and bool(data["determinate"].all())
    assert list(table.columns) == [column.name for column in four_bar.columns]
    assert (table["theta"].to_numpy() == four_bar["theta"]).all() and table.attrs["units"]["theta"] == "rad"


def test_loaded_and_live_are_compared_at_the_saved_times(four_bar, tmp_path):
    back = Run.load(four_bar.save(tmp_path / "run.csv"))
    assert compare(four_bar, back).largest.largest == 0
    assert compare(back, back).largest.largest == 0


def test_a_missing_library_is_one_line(four_bar, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match=r"^this needs xarray, which is not installed: pip install xarray$"):
        four_bar.to_xarray()


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_a_file_that_was_cut_or_edited_is_refused(suffix, four_bar, tmp_path):
    whole = four_bar.save(tmp_path / f"run{suffix}").read_bytes()
    rng, path = np.random.default_rng(5), tmp_path / f"damaged{suffix}"
    damaged = [whole[:n] for n in rng.integers(0, len(whole), 20)] + [whole[:-40], b"", bytes(1000), b"t,theta\n"]
    # Figures, the model, names: one byte becomes another, which says nothing in the padding of netCDF and in the last of many figures.
    for place in rng.integers(0, len(whole) - 40, 40):
        damaged.append(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
    if suffix == ".csv":
        rows = whole.splitlines(keepends=True)
        damaged += [b"".join(rows[:-1]), b"".join([*rows, rows[-1]]), b"".join([*rows[:5], *rows[6:]]), b"".join(rows[2:])]
    damaged = [each for each in damaged if each != whole]
    taken = 0
    for each in damaged:
        path.write_bytes(each)
        try:
            back = Run.load(path)
        except ValueError as error:
            assert str(error).startswith(f"{path} is ")
        else:
            taken += 1
            assert all(np.array_equal(back.blocks[kind], block, equal_nan=True) for kind, block in four_bar.blocks.items())
    assert taken <= 5


def test_a_file_of_another_version_is_refused_by_it(four_bar, tmp_path):
    path = four_bar.save(tmp_path / "run.csv")
    path.write_text(path.read_text().replace('{"format": 2,', '{"format": 1,', 1))
    with pytest.raises(ValueError, match="is in format 1 of saved runs; this freebody reads 2"):
        Run.load(path)


def test_other_files_are_refused(four_bar, tmp_path):
    (tmp_path / "folder.nc").mkdir()
    with pytest.raises(ValueError, match="no regular file"):
        Run.load(tmp_path / "folder.nc")
    with pytest.raises(ValueError, match=r"\.nc or \.csv"):
        four_bar.save(tmp_path / "run.xlsx")
