# Writes OUTPUT, a C++ source of source_revision(), where its text changed: cmake -DSOURCE=… -DOUTPUT=… -P this
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=8 HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
                ERROR_QUIET RESULT_VARIABLE failed)
set(text "")
if(NOT failed)
  execute_process(COMMAND git -C ${SOURCE} diff --quiet HEAD ERROR_QUIET RESULT_VARIABLE changed)
  set(text " (git ${commit}")
  if(changed)
    string(APPEND text "+")
  endif()
  string(APPEND text ")")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#include \"revision.h\"

std::string petzval::cli::source_revision() { return \"${text}\"; }
")
