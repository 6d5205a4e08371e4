// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/files/file_batch.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "engine/run/files/export.hpp"
#include "engine/run/files/write_all.hpp"

namespace extremal {

void writeAll(int descriptor, std::string_view text, const std::filesystem::path& file) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t n = ::write(descriptor, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw ExportError(file, std::strerror(errno));
        done += static_cast<std::size_t>(n);
    }
}

namespace {

/// ".HOST.PID.tmp", of a host without dots and other doubtful characters.
std::string suffixOf(pid_t process) {
    struct utsname system {};
    std::string host = ::uname(&system) == 0 ? system.nodename : "";
    for (char& c : host)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    return "." + host + "." + std::to_string(process) + ".tmp";
}

/// Whether a temporary name is that of a process of this machine that has ended.
bool isLeftOver(const std::string& name) {
    if (!name.starts_with(".") || !name.ends_with(".tmp")) return false;
    const std::size_t end = name.size() - 4, dot = name.rfind('.', end - 1);
    if (dot == std::string::npos) return false;
    pid_t process = 0;
    const auto [last, error] = std::from_chars(name.data() + dot + 1, name.data() + end, process);
    if (error != std::errc() || last != name.data() + end || process <= 0) return false;
    if (!name.ends_with(suffixOf(process))) return false;
    return process != ::getpid() && ::kill(process, 0) != 0 && errno == ESRCH;
}

void removeLeftOvers(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (std::filesystem::directory_iterator at(folder, ignored), end; !ignored && at != end;
         at.increment(ignored))
        if (isLeftOver(at->path().filename().string())) {
            std::error_code kept;  // of another user, perhaps
            std::filesystem::remove(at->path(), kept);
        }
}

}  // namespace

std::filesystem::path FileBatch::temporary(const std::string& name) const {
    return folder_ / ("." + name + suffixOf(::getpid()));
}

FileBatch::~FileBatch() {
    if (descriptor_ >= 0) ::close(descriptor_);
    std::error_code ignored;
    for (const std::string& name : names_) std::filesystem::remove(temporary(name), ignored);
}

void FileBatch::open(const std::string& name) {
    const auto path = temporary(name);
    const auto make = [&] {
        return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    };
    if (!std::exchange(isCleared_, true)) removeLeftOvers(folder_);
    descriptor_ = make();
    if (descriptor_ < 0 && errno == EEXIST && ::unlink(path.c_str()) == 0)
        descriptor_ =
            make();  // of an earlier process with this number, or a link that somebody has put there
    if (descriptor_ < 0) throw ExportError(folder_ / name, std::strerror(errno));
    names_.push_back(name);
}

void FileBatch::append(const std::string& text) { writeAll(descriptor_, text, folder_ / names_.back()); }

void FileBatch::close() {
    // Some file systems tell only now that they are full.
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) throw ExportError(folder_ / names_.back(), std::strerror(errno));
}

void FileBatch::write(const std::string& name, const std::string& text) {
    open(name);
    append(text);
    close();
}

std::vector<std::string> FileBatch::commit(const Replacing& replacing) {
    std::vector<std::string> changed;
    for (const std::string& name : names_)
        if (mayReplace(folder_ / name, temporary(name), replacing)) changed.push_back(name);
    for (const std::string& name : names_) {
        std::error_code error;
        if (std::find(changed.begin(), changed.end(), name) == changed.end()) {
            std::filesystem::remove(temporary(name), error);
            continue;
        }
        std::filesystem::rename(temporary(name), folder_ / name, error);
        if (error) throw ExportError(folder_ / name, error.message());
    }
    return std::move(names_);
}

void prepareFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    std::error_code unknown;
    const bool isFolder = std::filesystem::is_directory(folder, unknown);
    if (!isFolder && error) throw ExportError(folder, error.message());
    if (!isFolder) throw ExportError(folder, unknown ? unknown.message() : "is not a folder");
    FileBatch trial(folder);
    trial.write("trial", "");
}

void writeFile(const std::filesystem::path& path, const std::string& text, const Replacing& replacing) {
    FileBatch batch(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."));
    batch.write(path.filename().string(), text);
    batch.commit(replacing);
}

}  // namespace extremal
