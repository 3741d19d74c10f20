#include "app/program.hpp"

#ifndef VIBROTROUGH_PROGRAM_WITH_VTK
#define VIBROTROUGH_PROGRAM_WITH_VTK ""  // this program needs no other
#endif

int main(int argc, char** argv) {
    return vibrotrough::app::run_program(VIBROTROUGH_PROGRAM_WITH_VTK, argc, argv);
}
