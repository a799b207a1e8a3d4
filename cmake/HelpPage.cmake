# cmake -DPROGRAM=billet-render -DVERSION=0.1.0 -DPAGE=billet-render.1 -P HelpPage.cmake
# A manual page of what a program says of itself with --help.
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --help: ${status}")
endif()
string(REPLACE "\\" "\\e" help "${help}")
string(REPLACE "-" "\\-" help "${help}")
string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" help "${help}")
file(WRITE ${PAGE}
     ".TH BILLET\\-RENDER 1 \"\" \"billet ${VERSION}\" \"User Commands\"
.SH NAME
billet\\-render \\- pictures of results and curves of billet
.SH DESCRIPTION
.nf
${help}.fi
.SH EXIT STATUS
0 done; 2 usage; 6 a file could not be read or written.
.SH SEE ALSO
.BR billet (1)
")
