# Warnings for our own targets only; link it PRIVATE.
add_library(burnish_warnings INTERFACE)
target_compile_options(burnish_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                  $<$<BOOL:${BURNISH_WERROR}>:-Werror>)
