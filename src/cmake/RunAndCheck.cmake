# Runs COMMAND, then CHECK; both are lists separated by |. Fails if either does.
foreach(part COMMAND CHECK)
  string(REPLACE "|" ";" command "${${part}}")
  execute_process(COMMAND ${command} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "exit status ${status}: ${command}")
  endif()
endforeach()
