// Style sheets and scripts of reports as bytes of the program.
    .section .rodata
    .global wrlkit_style_begin
    .global wrlkit_style_end
    .global wrlkit_theme_begin
    .global wrlkit_theme_end
    .global wrlkit_corpus_table_begin
    .global wrlkit_corpus_table_end
    .global wrlkit_gallery_begin
    .global wrlkit_gallery_end
wrlkit_style_begin:
    .incbin WRLKIT_REPORT_BASE_CSS
    .incbin WRLKIT_REPORT_CSS
wrlkit_style_end:
wrlkit_theme_begin:
    .incbin WRLKIT_REPORT_THEME
wrlkit_theme_end:
wrlkit_corpus_table_begin:
    .incbin WRLKIT_REPORT_CORPUS_TABLE
wrlkit_corpus_table_end:
wrlkit_gallery_begin:
    .incbin WRLKIT_REPORT_GALLERY
wrlkit_gallery_end:
    .section .note.GNU-stack,"",%progbits
