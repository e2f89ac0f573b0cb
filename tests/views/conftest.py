"""Runs shared by the views' tests; made once."""

import pytest

from .models import run_double_pendulum, run_four_bar, run_shelf


@pytest.fixture(scope="session")
def pendulum():
    return run_double_pendulum()


@pytest.fixture(scope="session")
def four_bar():
    return run_four_bar()


@pytest.fixture(scope="session")
def indeterminate():
    return run_shelf()
