#compdef contactscope
# zsh completion of contactscope; made by contactscope --manual zsh

local line
local -a found space
for line in ${(f)"$(contactscope --complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)"}; do
  case $line in
    :files) _files ;;
    :folders) _files -/ ;;
    :nospace) space=(-S '') ;;
    *) found+=("${${line//:/\\:}/$'\t'/:}") ;;
  esac
done
_describe contactscope found $space
