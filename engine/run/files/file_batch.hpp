// SPDX-License-Identifier: GPL-3.0-or-later
/// Files that appear together: each is written under a temporary name, and all are renamed at the end.
/// Internal to engine/run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/run/files/replacing.hpp"

namespace extremal {

/// Temporary names hold the machine and the process, ".NAME.HOST.PID.tmp": what a process has left that was
/// killed is taken away by the next that writes into the folder. They are made anew and never opened through
/// a link.
class FileBatch {
public:
    explicit FileBatch(std::filesystem::path folder) : folder_(std::move(folder)) {}
    ~FileBatch();  ///< removes what was not committed
    FileBatch(const FileBatch&) = delete;
    FileBatch& operator=(const FileBatch&) = delete;

    /// All throw ExportError.
    void open(const std::string& name);
    void append(const std::string& text);
    void close();
    void write(const std::string& name, const std::string& text);
    /// Gives the files their names, and returns these: all of them, or, where one may not be replaced, none.
    std::vector<std::string> commit(const Replacing& replacing);

private:
    std::filesystem::path temporary(const std::string& name) const;

    std::filesystem::path folder_;
    bool isCleared_ = false;  ///< of what others have left
    std::vector<std::string> names_;
    int descriptor_ = -1;
};

}  // namespace extremal
