"""The language of messages: that of the user's system."""

from __future__ import annotations

import os
import sys

from .errors import LANGUAGES


def system_language() -> str:
    """Return the language of messages: that of the environment, or of Windows; English for any other."""
    for variable in ("LC_ALL", "LC_MESSAGES", "LANG"):
        if os.environ.get(variable):
            name = os.environ[variable]
            break
    else:
        name = _windows_language()
    return name[:2].lower() if name[:2].lower() in LANGUAGES else "en"


def _windows_language() -> str:
    """Return the language in which Windows shows itself to the user; nothing elsewhere."""
    if sys.platform != "win32":
        return ""
    import ctypes
    import locale

    return locale.windows_locale.get(ctypes.windll.kernel32.GetUserDefaultUILanguage(), "")
