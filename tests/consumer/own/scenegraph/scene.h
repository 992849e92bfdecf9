// Of a program that uses wrlkit (CMakeLists.txt): called as one of wrlkit's headers is.
#error "a header of the program instead of wrlkit's"
