# The manual page and the completions of shells, written by the program from its own options.
set(text_dir ${CMAKE_CURRENT_BINARY_DIR}/texts)
set(texts)
foreach(text man:perilink.1 bash:perilink zsh:_perilink fish:perilink.fish)
  string(REPLACE ":" ";" text ${text})
  list(GET text 0 kind)
  list(GET text 1 name)
  add_custom_command(OUTPUT ${text_dir}/${kind}/${name}
                     COMMAND ${CMAKE_COMMAND} -E make_directory ${text_dir}/${kind}
                     COMMAND perilink --describe ${kind} > ${text_dir}/${kind}/${name}
                     DEPENDS perilink VERBATIM)
  list(APPEND texts ${text_dir}/${kind}/${name})
endforeach()
add_custom_target(option_texts ALL DEPENDS ${texts})
install(FILES ${text_dir}/man/perilink.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${text_dir}/bash/perilink
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${text_dir}/zsh/_perilink DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${text_dir}/fish/perilink.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
