from . import fake_core

fake_core.install()
