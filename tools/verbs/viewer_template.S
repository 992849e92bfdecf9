// The viewer pages as bytes of the program.
    .section .rodata
    .global wrlkit_viewer_begin
    .global wrlkit_viewer_end
    .global wrlkit_tiles_begin
    .global wrlkit_tiles_end
wrlkit_viewer_begin:
    .incbin WRLKIT_VIEWER_FILE
wrlkit_viewer_end:
wrlkit_tiles_begin:
    .incbin WRLKIT_TILES_FILE
wrlkit_tiles_end:
    .section .note.GNU-stack,"",%progbits
