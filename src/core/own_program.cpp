#include "core/own_program.hpp"

#include "core/error.hpp"

namespace vibrotrough::core {

std::optional<std::filesystem::path> find_own_program() {
    std::error_code failure;
    std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failure);
    return failure ? std::nullopt : std::optional(std::move(program));
}

std::filesystem::path own_program() {
    if (auto program = find_own_program()) return *std::move(program);
    throw MissingError(
        "the kernel does not tell where this program lies; mount /proc, and run the command again");
}

}  // namespace vibrotrough::core
