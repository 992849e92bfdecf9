// annex_c.js as bytes of the program.
    .section .rodata
    .global wrlkit_annex_c_begin
    .global wrlkit_annex_c_end
wrlkit_annex_c_begin:
    .incbin WRLKIT_ANNEX_C
wrlkit_annex_c_end:
    .section .note.GNU-stack,"",%progbits
