// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/regular_file.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace extremal {
namespace {

struct OpenFile {
    int descriptor;
    ~OpenFile() {
        if (descriptor >= 0) ::close(descriptor);
    }
};

}  // namespace

std::string readRegularFile(const std::string& path, std::size_t most) {
    // What a path names may change after it was looked at, so that the open file is asked; without
    // O_NONBLOCK opening a pipe would wait for who writes into it.
    const OpenFile file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)};
    if (file.descriptor < 0) throw UnreadableFile(std::string("cannot be opened: ") + std::strerror(errno));
    struct stat status {};
    if (::fstat(file.descriptor, &status) != 0)
        throw UnreadableFile(std::string("cannot be read: ") + std::strerror(errno));
    if (S_ISDIR(status.st_mode)) throw UnreadableFile("is a folder");
    if (!S_ISREG(status.st_mode)) throw UnreadableFile("is not a regular file");
    std::string text;
    char block[1 << 16];
    for (;;) {
        const ssize_t n = ::read(file.descriptor, block, sizeof block);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw UnreadableFile(std::string("cannot be read: ") + std::strerror(errno));
        if (n == 0) return text;
        text.append(block, static_cast<std::size_t>(n));
        if (text.size() > most) throw UnreadableFile("is larger than " + std::to_string(most >> 20) + " MB");
    }
}

}  // namespace extremal
