#include "core/hash.hpp"

#include <array>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

// FIPS 180-4 example values.
TEST(Hash, IsSha256) {
    EXPECT_EQ(core::sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(core::sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

// The digest does not depend on how the bytes are cut.
TEST(Hash, OfPieces) {
    std::array<std::string_view, 3> const pieces{"a", "", "bc"};
    EXPECT_EQ(core::sha256_hex(pieces), core::sha256_hex("abc"));
}

}  // namespace
}  // namespace vibrotrough
