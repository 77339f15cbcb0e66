"""How the image builder fails: what, why, and what to do."""

import subprocess


class ImageError(Exception):
    """Message: WHAT: REASON (WHAT TO DO)."""


def run(words, hint="", **options):
    """The output of a command. ImageError with its last words where it fails."""
    try:
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    except FileNotFoundError as error:
        raise ImageError(f"{words[0]}: not installed (./dev image installs what it needs)") from error
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()
        reason = said[-1] if said else f"exit code {done.returncode}"
        raise ImageError(f"{words[0]}: {reason}{f' ({hint})' if hint else ''}")
    return done.stdout
