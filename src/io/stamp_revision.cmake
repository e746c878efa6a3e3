# Writes the header that provenance.cpp includes: version and revision of the source, compiler flags.
execute_process(
  COMMAND git describe --always --dirty --abbrev=12
  WORKING_DIRECTORY ${SOURCE_DIR}
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE
  RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  set(revision unknown)
endif()
file(WRITE ${OUTPUT}
  "#define ROTOR_STATOR_REVISION \"rotor_stator ${VERSION} ${revision}\"\n#define ROTOR_STATOR_FLAGS \"${FLAGS}\"\n")
