# Writes the header that provenance.cpp includes: revision of the source and compiler flags.
execute_process(
  COMMAND git describe --always --dirty --abbrev=12
  WORKING_DIRECTORY ${SOURCE_DIR}
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE
  RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  set(revision unknown)
endif()
file(WRITE ${OUTPUT}
  "#define ROTOR_STATOR_REVISION \"${revision}\"\n#define ROTOR_STATOR_FLAGS \"${FLAGS}\"\n")
