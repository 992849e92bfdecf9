// The style sheets of reports as bytes of the program.
    .section .rodata
    .global wrlkit_style_begin
    .global wrlkit_style_end
wrlkit_style_begin:
    .incbin WRLKIT_STYLE_BASE
    .incbin WRLKIT_STYLE_REPORT
wrlkit_style_end:
    .section .note.GNU-stack,"",%progbits
