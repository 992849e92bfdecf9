    words_for() {  # the words of a command; prints what may stand for the last
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
        _wrlkit
        echo "${COMPREPLY[@]}"
    }
    source <(wrlkit completion bash) &&
        words_for wrlkit optim &&
        words_for wrlkit corpus r &&
        words_for wrlkit convert --compr &&
        words_for wrlkit convert plant.wrl plant.glb --compress m &&
        words_for wrlkit corpus run --sh &&
        words_for wrlkit info corpus/plant/pump_room_f
