"""The module run by ``python -m uwsim.cli``, which is ``uwsim``."""

from __future__ import annotations

import sys

from .app import main

sys.exit(main())
