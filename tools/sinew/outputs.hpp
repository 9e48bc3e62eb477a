// Outputs. Everything is checked before a run begins and written whole after it: a file gets its final name
// only when it is complete.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sinew::tools {

/// The text result of a command: "-" is stdout, otherwise a file.
class TextOutput {
public:
    /// Throws app::Failure (outputFailed) if the file's folder is missing or not writable.
    explicit TextOutput(std::string target);
    void write(const std::string& text) const;

private:
    std::string target_;
};

/// A folder for results, created if missing and locked against a second run during its lifetime.
class OutputFolder {
public:
    /// Throws app::Failure (outputFailed) if the folder cannot be created or written to, or is in use.
    explicit OutputFolder(std::filesystem::path folder);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return folder_; }

private:
    std::filesystem::path folder_, lockFile_;
    int lock_ = -1;
};

/// A scene's name as a file name of at most 64 bytes: letters of every script, digits, '-' and '_' in UTF-8;
/// other characters become '_'. Never empty.
std::string fileName(const std::string& name);

} // namespace sinew::tools
