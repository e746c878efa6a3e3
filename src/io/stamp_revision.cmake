# Writes the header that table.cpp includes: version and revision of the source, compiler flags. The
# revision is that of the sources' own repository, not of one around them, and -dirty where what is
# compiled differs from it.
function(git output)
  execute_process(COMMAND git ${ARGN} WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE text
    OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(failed)
    set(text "")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

set(revision unknown)
git(prefix rev-parse --is-inside-work-tree --show-prefix)
if(prefix STREQUAL "true")
  git(revision describe --always --abbrev=12)
  if(NOT revision)
    set(revision unknown)
  endif()
  git(changes --no-optional-locks status --porcelain -- src CMakeLists.txt CMakePresets.json)
  if(changes)
    string(APPEND revision -dirty)
  endif()
endif()

set(header "#define ROTOR_STATOR_REVISION \"rotor_stator ${VERSION} ${revision}\"
#define ROTOR_STATOR_FLAGS \"${FLAGS}\"
")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT header STREQUAL before)
  file(WRITE ${OUTPUT} "${header}")
endif()
