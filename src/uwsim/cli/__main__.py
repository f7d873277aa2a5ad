"""``python -m uwsim.cli`` is ``uwsim``."""

from __future__ import annotations

import sys

from .app import main

sys.exit(main())
