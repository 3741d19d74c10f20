#pragma once

#include <string>
#include <string_view>

namespace vibrotrough::core {

/// The reason of a failed system call in words, with the limit of this process (`ulimit`) that was reached,
/// if it was one: the number of open files (EMFILE) or processes (EAGAIN), the size of a file (EFBIG).
/// @param error  an errno
std::string reason_of(int error);

/// Makes sure that this process may have so many files open.
/// @param least  number of files
/// @param what   begin of the message: "an engine needs"
/// @throws MissingError that names the limit
void require_open_files(unsigned long least, std::string_view what);

/// Makes sure, by trying, that this user may start so many processes or threads now.
/// @param count  of processes and threads
/// @param what   begin of the message: "an engine needs"
/// @throws MissingError that names the limit
void require_processes(int count, std::string_view what);

}  // namespace vibrotrough::core
