# bash completion of contactscope; made by contactscope --manual bash

_contactscope() {
  local cur=${COMP_WORDS[COMP_CWORD]} word
  if [ "$cur" = = ]; then cur=; fi
  COMPREPLY=()
  while IFS= read -r word; do
    word=${word%%$'\t'*}
    case $word in
      :files) COMPREPLY+=($(compgen -f -- "$cur")) ;;
      :folders) COMPREPLY+=($(compgen -d -- "$cur")) ;;
      :nospace) compopt -o nospace 2>/dev/null || true ;;
      "$cur"*)
        [[ $word == *[!A-Za-z0-9_./+@%:,=~-]* ]] && word=$(printf %q "$word")
        COMPREPLY+=("$word") ;;
    esac
  done < <(contactscope --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -o bashdefault -F _contactscope contactscope
