"""Hypothesis: few examples, so that the whole suite stays quick; the same ones every time on a build machine."""

import os

import pytest
from hypothesis import HealthCheck
from hypothesis import settings as hypothesis_settings
from PySide6.QtWidgets import QApplication

from widgets import theme

_quick = {"deadline": None, "max_examples": 200, "suppress_health_check": [HealthCheck.too_slow]}
hypothesis_settings.register_profile("here", **_quick)
hypothesis_settings.register_profile("ci", derandomize=True, **_quick)
hypothesis_settings.load_profile("ci" if os.environ.get("CI") == "true" else "here")


@pytest.fixture(scope="session")
def qapp(qapp: QApplication) -> QApplication:
    """The application as users see it: dark, with our fonts and sizes."""
    theme.apply(qapp)
    return qapp
