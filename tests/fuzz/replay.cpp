// In place of libFuzzer: hands every file of the folders that are named to the target once, with any compiler
// and without a sanitizer.

#include "core/atomic_file.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);

int main(int count, char** words) {
    int inputs = 0;
    for (int i = 1; i < count; ++i)
        for (auto const& file : std::filesystem::directory_iterator(words[i])) {
            std::puts(file.path().c_str());
            std::fflush(stdout);  // the last line is the input that a target fell over
            std::string const input = vibrotrough::core::read_file(file.path());
            LLVMFuzzerTestOneInput(reinterpret_cast<std::uint8_t const*>(input.data()), input.size());
            ++inputs;
        }
    std::printf("%d inputs\n", inputs);
    return inputs > 0 ? 0 : 1;
}
