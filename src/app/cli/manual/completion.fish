# fish completion of contactscope; made by contactscope --manual fish

function __contactscope_complete
    set -l typed (commandline -ct)
    set -l words (commandline -opc)
    for line in (contactscope --complete $words[2..-1] "$typed" 2>/dev/null)
        switch $line
            case :files
                __fish_complete_path "$typed"
            case :folders
                __fish_complete_directories "$typed"
            case :nospace
            case '*'
                echo $line
        end
    end
end
complete -c contactscope -f -a '(__contactscope_complete)'
