// The viewer page as bytes of the program.
    .section .rodata
    .global wrlkit_viewer_begin
    .global wrlkit_viewer_end
wrlkit_viewer_begin:
    .incbin WRLKIT_VIEWER_FILE
wrlkit_viewer_end:
    .section .note.GNU-stack,"",%progbits
