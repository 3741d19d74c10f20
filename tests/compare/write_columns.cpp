// Prints the columns of `compare` as they stand in the report's campaign.json; with --markdown the list of
// src/manual/howto/compare.md.

#include "compare/exports.hpp"

#include <cstdio>
#include <string_view>

#include <nlohmann/json.hpp>

int main(int argc, char** argv) {
    using namespace vibrotrough::compare;
    bool const markdown = argc > 1 && std::string_view(argv[1]) == "--markdown";
    std::printf("%s", markdown ? column_reference().c_str() : column_descriptions().dump(2).c_str());
    return 0;
}
