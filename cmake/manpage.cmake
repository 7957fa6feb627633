# Turns what a command prints for --help into its man page, so that there is one text to keep:
#   cmake -DCOMMAND=path -DNAME=name -DVERSION=x.y.z -DOUTPUT=name.1 -P manpage.cmake
execute_process(COMMAND ${COMMAND} --help OUTPUT_VARIABLE help RESULT_VARIABLE status)
if(status)
  message(FATAL_ERROR "${NAME} --help failed")
endif()
string(REPLACE "\\" "\\e" help "${help}")
string(REPLACE "\n." "\n\\&." help "${help}")
string(REPLACE "\n'" "\n\\&'" help "${help}")
string(REPLACE "-" "\\-" help "${help}")
string(REGEX MATCH "^[^\n]*" summary "${help}")
string(TOUPPER ${NAME} upper)
file(WRITE ${OUTPUT}
     ".TH ${upper} 1 \"\" \"isohull ${VERSION}\" \"User Commands\"\n.SH NAME\n${NAME} \\- part of isohull\n"
     ".SH DESCRIPTION\n.nf\n${help}.fi\n")
