"""The command line, one file a command; nobody imports it.

`app` names the commands and turns errors into exit statuses, `options` holds what several commands take and `tables`
what several print. Whatever is slow to import is imported when a command is called.
"""

from drumrs.cli.app import main, run_command

__all__ = ["main", "run_command"]
