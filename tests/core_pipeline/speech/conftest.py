"""One warm pocketsphinx and one warm espeak-ng for all tests of speech."""

import pytest

from core_pipeline.speech.espeak import Espeak
from core_pipeline.speech.sphinx import Sphinx


@pytest.fixture(scope="package")
def sphinx():
    ears = Sphinx()
    yield ears
    ears.close()


@pytest.fixture(scope="package")
def voice():
    warm = Espeak()
    yield warm
    warm.close()
