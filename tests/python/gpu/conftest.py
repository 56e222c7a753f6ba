"""What every test of the engine needs: small environments, and a validation layer that stays silent."""

import pytest

import burnish
from burnish import environments


@pytest.fixture(scope="session", autouse=True)
def no_validation_message(device):
    """Fail the session if the validation layer said anything to its device, warnings included.

    Its hints on speed are no faults: images stay in the general layout, which costs nothing on CPU drivers.
    """
    yield
    messages = device.validation_messages()
    assert [message for message in messages if "Performance Warning" not in message] == []


@pytest.fixture(scope="session")
def spots64():
    """Discs of 30 to 3000 over a background of about 1: the map on which samplers differ most."""
    return environments.spots(face_size=64)


@pytest.fixture(scope="session")
def spots128():
    return environments.spots(face_size=128)


@pytest.fixture(scope="session")
def uniform():
    return environments.uniform(1.0, face_size=8)


@pytest.fixture(scope="session")
def smooth64():
    from engine_support import smooth_environment_faces

    return burnish.Environment.from_faces(smooth_environment_faces(64))
