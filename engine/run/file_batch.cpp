#include "engine/run/file_batch.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "engine/run/export.hpp"
#include "engine/run/write_all.hpp"

namespace extremal {

void writeAll(int descriptor, std::string_view text, const std::filesystem::path& file) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t n = ::write(descriptor, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw ExportError(file, std::strerror(errno));
        done += static_cast<std::size_t>(n);
    }
}

std::filesystem::path FileBatch::temporary(const std::string& name) const {
    return folder_ / ("." + name + "." + std::to_string(::getpid()) + ".tmp");
}

FileBatch::~FileBatch() {
    if (descriptor_ >= 0) ::close(descriptor_);
    std::error_code ignored;
    for (const std::string& name : names_) std::filesystem::remove(temporary(name), ignored);
}

void FileBatch::open(const std::string& name) {
    const auto path = temporary(name);
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
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
    if (error && !std::filesystem::is_directory(folder)) throw ExportError(folder, error.message());
    if (!std::filesystem::is_directory(folder)) throw ExportError(folder, "is not a folder");
    FileBatch trial(folder);
    trial.write("trial", "");
}

void writeFile(const std::filesystem::path& path, const std::string& text, const Replacing& replacing) {
    FileBatch batch(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."));
    batch.write(path.filename().string(), text);
    batch.commit(replacing);
}

}  // namespace extremal
