#include "view_script.h"

// The assembler takes the file in as it is: as an array in C++ it would take the compiler a minute.
asm(".section .rodata\n"
    ".global hexwall_view_script_begin\n"
    ".global hexwall_view_script_end\n"
    "hexwall_view_script_begin:\n"
    ".incbin \"" HEXWALL_VIEW_SCRIPT
    "\"\n"
    "hexwall_view_script_end:\n"
    ".byte 0\n"
    ".previous\n");

extern "C" {
extern const char hexwall_view_script_begin[];
extern const char hexwall_view_script_end[];
}

namespace hexwall {

std::string_view view_script() {
  return {hexwall_view_script_begin, hexwall_view_script_end};
}

}  // namespace hexwall
