# Turns what a command prints for --help into man pages, one of the command and one of each
# subcommand, and into completions of bash, zsh and fish, so that there is one text to keep:
#   cmake -DCOMMAND=path -DNAME=name -DVERSION=x.y.z -DOUTPUT=folder -P manpage.cmake
# Fills folder/man1, folder/bash, folder/zsh and folder/fish.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${OUTPUT})

function(page name heading summary help see)
  set(text "${help}")
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "\n." "\n\\&." text "${text}")
  string(REPLACE "\n'" "\n\\&'" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REPLACE "-" "\\-" page_name "${name}")
  string(REPLACE "-" "\\-" summary "${summary}")
  string(TOUPPER ${name} upper)
  file(WRITE ${OUTPUT}/man1/${name}.1
       ".TH ${upper} 1 \"\" \"isohull ${VERSION}\" \"User Commands\"\n.SH NAME\n${page_name} \\- ${summary}\n"
       ".SH ${heading}\n.nf\n${text}.fi\n.SH SEE ALSO\n${see}\n")
endfunction()

execute_process(COMMAND ${COMMAND} --help OUTPUT_VARIABLE help RESULT_VARIABLE status)
if(status)
  message(FATAL_ERROR "${NAME} --help failed")
endif()

# Words of the help that are a subcommand: the command knows them.
string(REPLACE ";" "," lines "${help}")
string(REGEX MATCHALL "\n(  |usage: ${NAME} |       ${NAME} )?[a-z]+ [^\n]*" lines "\n${lines}")
set(subcommands "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^\n(  |usage: ${NAME} |       ${NAME} )?([a-z]+) .*" "\\2" word "${line}")
  if(word IN_LIST subcommands)
    continue()
  endif()
  execute_process(COMMAND ${COMMAND} ${word} --help OUTPUT_VARIABLE own RESULT_VARIABLE status ERROR_QUIET)
  if(status OR NOT own MATCHES "${NAME} ${word}")
    continue()
  endif()
  list(APPEND subcommands ${word})
  set(summary "subcommand of ${NAME}")
  string(REPLACE ";" "," flat "\n${help}")
  if(flat MATCHES "\n  ${word}( [^ \n]+)*  +([a-z][^\n]*)")
    set(summary "${CMAKE_MATCH_2}")
  elseif(flat MATCHES "\n${word} +([a-z]([^\n,.]|[.][a-z])*)")
    set(summary "${CMAKE_MATCH_1}")
  endif()
  page(${NAME}-${word} DESCRIPTION "${summary}" "${own}" ".BR ${NAME} (1)")
  # Options of this subcommand alone, where one help has those of all.
  string(REPLACE ";" "," mine "${own}")
  if(mine MATCHES "\noptions of ${word}:\n")
    string(REGEX REPLACE ".*\noptions of ${word}:\n" "" mine "${mine}")
    string(REGEX REPLACE "\n\n.*" "\n" mine "${mine}")
  endif()
  string(REGEX MATCHALL "--[a-z][a-z-]*" options "${mine}")
  list(APPEND options --help --json --threads)
  list(REMOVE_DUPLICATES options)
  list(SORT options)
  set(options_${word} "${options}")
endforeach()
if(NOT subcommands)
  message(FATAL_ERROR "${NAME} --help names no subcommand")
endif()

set(see "")
foreach(word IN LISTS subcommands)
  list(APPEND see ".BR ${NAME}-${word} (1)")
endforeach()
list(JOIN see ",\n" see)
page(${NAME} DESCRIPTION "part of isohull" "${help}" "${see}")

# The shells: no semicolon, which would divide the text for CMake.
list(JOIN subcommands " " words)
set(bash "# Completion of ${NAME} for bash.
_isohull_${NAME}() {
    local word=\${COMP_WORDS[COMP_CWORD]} words=
    COMPREPLY=()
    if [ \"$COMP_CWORD\" = 1 ]
    then
        words='${words} --help --version'
")
set(zsh "#compdef ${NAME}
if (( CURRENT == 2 ))
then
    compadd -- ${words} --help --version
")
set(fish "# Completion of ${NAME} for fish.
complete -c ${NAME} -n __fish_use_subcommand -a '${words}'
complete -c ${NAME} -n __fish_use_subcommand -l help
complete -c ${NAME} -n __fish_use_subcommand -l version
")
foreach(word IN LISTS subcommands)
  list(JOIN options_${word} " " options)
  string(APPEND bash "    elif [ \"\${COMP_WORDS[1]}\" = ${word} ] && [[ $word == -* ]]
    then
        words='${options}'
")
  string(APPEND zsh "elif [[ $words[2] == ${word} && $PREFIX == -* ]]
then
    compadd -- ${options}
")
  foreach(option IN LISTS options_${word})
    string(SUBSTRING ${option} 2 -1 long)
    string(APPEND fish "complete -c ${NAME} -n '__fish_seen_subcommand_from ${word}' -l ${long}\n")
  endforeach()
endforeach()
string(APPEND bash "    fi
    [ -z \"$words\" ] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")
}
complete -o default -F _isohull_${NAME} ${NAME}
")
string(APPEND zsh "else
    _files
fi
")
file(WRITE ${OUTPUT}/bash/${NAME} "${bash}")
file(WRITE ${OUTPUT}/zsh/_${NAME} "${zsh}")
file(WRITE ${OUTPUT}/fish/${NAME}.fish "${fish}")
