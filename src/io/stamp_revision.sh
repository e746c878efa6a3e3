#!/bin/sh
# Writes the header that table.cpp includes: usage: stamp_revision.sh VERSION FLAGS HEADER, in the project's
# root. The revision is that of the sources' own repository, not of one around them, and -dirty where what is
# compiled differs from it.
revision=unknown
unset $(git rev-parse --local-env-vars 2> /dev/null)
if prefix=$(git rev-parse --show-prefix 2> /dev/null) && [ -z "$prefix" ]; then
  revision=$(git describe --always --abbrev=12 2> /dev/null) || revision=unknown
  changes=$(git --no-optional-locks status --porcelain -- src studies data/bearings CMakeLists.txt CMakePresets.json)
  [ -z "$changes" ] || revision=$revision-dirty
fi
printf '#define ROTOR_STATOR_REVISION "rotor_stator %s %s"\n#define ROTOR_STATOR_FLAGS "%s"\n' \
  "$1" "$revision" "$2" > "$3.new"
if cmp -s "$3.new" "$3"; then rm "$3.new"; else mv "$3.new" "$3"; fi
