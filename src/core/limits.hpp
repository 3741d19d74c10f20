#pragma once

#include <string>

namespace vibrotrough::core {

/// The reason of a failed system call in words, with the limit of this process (`ulimit`) that was reached,
/// if it was one: the number of open files (EMFILE) or processes (EAGAIN), the size of a file (EFBIG).
/// @param error  an errno
std::string reason_of(int error);

}  // namespace vibrotrough::core
