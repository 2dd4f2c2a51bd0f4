# The words that zsh offers for a line, one below the other: what its completion hands to compadd.
#   zsh -f zsh_offers.zsh FOLDER LINE        FOLDER has the completion; it works in the current folder
# A shell of its own at a pseudo-terminal completes the line as one that a person types.
zmodload zsh/zpty
offered=$(mktemp)
zpty shell zsh -f -i
zpty -w shell "PROMPT= TERM=dumb; fpath=(${(q)1} \$fpath); autoload -Uz compinit; compinit -u -D"
# compadd with -O, -A or -D looks at words and offers none.
zpty -w shell "compadd() {
  [[ \${@[1,(i)(-|--)]} == *-(O|A|D)\\ * ]] || { local -a words; builtin compadd -A words \"\$@\"
    print -rl -- \$words >>${(q)offered} }
  builtin compadd \"\$@\"
}; : >${(q)offered}.ready"
repeat 200; do [[ -e $offered.ready ]] && break; sleep 0.05; done
zpty -n -w shell "$2"$'\t'
repeat 100; do [[ -s $offered ]] && break; sleep 0.05; done
sleep 0.3
zpty -d shell
sort -u $offered
rm -f $offered $offered.ready
