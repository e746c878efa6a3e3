"""The keys of a table's header and footer (`# key: value`, a value is one word or
number)."""
import re

KEY = re.compile(r"^# ([A-Za-z_]\w*): (\S+)$", re.MULTILINE)
NO_NUMBER = re.compile(r"(?<![\w.])[-+]?(?:nan|inf|infinity)(?![\w.])", re.IGNORECASE)


def keys_of(text):
    """All keys, as text. A key that comes twice is an error."""
    found = KEY.findall(text)
    twice = {key for key, _ in found if [name for name, _ in found].count(key) > 1}
    if twice:
        raise ValueError(f"keys that come twice: {sorted(twice)}")
    return dict(found)


def number(keys, name, missing=float("nan")):
    return float(keys.get(name, missing))
