// A source for the library that brings the precompiled headers of the tests (CMakeLists.txt) to the compiler.
