"""What a person or a program might write by mistake."""

# Values of every TOML type, at and beyond the limits of each.
VALUES = [
    "nan", "+nan", "-nan", "inf", "-inf", "0", "-0", "0.0", "-0.0", "1", "-1", "1e308", "-1e308", "1e309",
    "1e-308", "1e-320", "5e-324", "1e-400", "0x10", "0xffffffffffffffff", "0b101", "0o17",
    "9223372036854775807", "-9223372036854775808", "9223372036854775808", "99999999999999999999999999",
    "1_000", "1__0", "01", "1.", ".5", "1e", "1e+", "--1", "1.2.3", "true", "false", "True", "null",
    '""', '"text"', "'literal'", r'"\u00e9"', r'"\ud800"', r'"\x"', r'"a\nb"', r'"a\tb"', r'"\u0000"',
    '"""multi\nline"""', "'''a\nb'''", '"open', "[]", "[1]", "[1, 2]", '[1, "a"]', "[[1]]", "[", "[1,,2]",
    "{}", "{a = 1}", "{a = {b = {c = 1}}}", "{", "1979-05-27", "1979-05-27T07:32:00Z", "07:32:00",
    "25:61:61", "1979-13-45", "", " ", "=", "# no value", "1 2", "1, 2", "16.5", "16.0", "1025", "1024",
    "2", "0.5000000001", "1e3000000000", "1e11 N/m", "１", "½", "∞"]

# What may stand where a key or a table should.
LINES = [
    "[", "]", "[]", "[[]]", "[[bearing]]", "[bearing.inner]", "[stator]", "[ rotor ]", "[a.b.c.d]", '[""]',
    "[bearing", "= 1", "a.b = 1", '"" = 1', '"mass_kg" = 1', "mass_kg.x = 1", "stator = 1", "stator = {}",
    "key = key", "# comment", "\t", "\\", '"', "'", "{}", "1", 'title = "again"', "ball_radius_m = 0.01",
    "inner_race_radius_m = 0.07", "ball_radius_m = 1e300", 'include "x"', "<xml/>", "é = 1",
    "key\u200b = 1", "\u2028"]

# Values that no option takes, or that only some do.
WORDS = [
    "", " ", "nan", "NaN", "-nan", "inf", "-inf", "infinity", "0", "-0", "0.0", "-1", "1e308", "1e309",
    "1e-308", "1e-320", "5e-324", "0x10", "0x1p-1074", "1e", "1,5", "1 2", "ten", "--", "-", "--help",
    "--version", "2147483647", "2147483648", "-2147483648", "4294967296", "9223372036854775808", "1e3",
    "3.5", "+5", "05", "1_000", "1e400", "é", "∞", "%s%n", "$(true)", "'", '"', "\n", "\t5", "5 ", "5Hz",
    "true", "machine.toml", "/dev/null", "@machine.toml", "[1,2]", "{}", "\udcff\udcfe", "aft ", "AFT"]

# Where no parameter file is.
PATHS = ["", ".", "/", "no/such/file", "/dev/null", "/dev/zero", "out", "../x", "machine.toml/",
         "machine.toml\n", "\udcff", "-", "--", "/proc/self/mem"]

# Where nothing can be saved, or must not be.
SAVES = ["", ".", "..", "machine.toml", "no/such/folder/file", "/dev/null", "/dev/full", "link", "x" * 300]

# What may replace a cell of a table.
CELLS = ["", " ", "nan", "inf", "-inf", "1e309", "1e-400", "-1", "0", "x", "0x10", "1\t1", "\n", "1,5", "#"]
