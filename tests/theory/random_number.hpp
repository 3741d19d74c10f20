#pragma once

#include <cstdint>

#include <rapidcheck.h>

namespace vibrotrough::theory {

/// A random number in [low, high]. RapidCheck itself generates whole numbers only.
inline double between(double low, double high) {
    auto const part = *rc::gen::inRange<std::int64_t>(0, 1'000'000'001);
    return low + (high - low) * static_cast<double>(part) * 1e-9;
}

}  // namespace vibrotrough::theory
