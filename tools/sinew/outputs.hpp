// Where results go. Everything is checked before a run begins and written whole after it: a file has its
// final name only once it is complete.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sinew::tools {

/// A text that is the result of a command: "-" is stdout, else a file.
class TextOutput {
public:
    /// Throws app::Failure (outputFailed) where the file's folder is missing or not writable.
    explicit TextOutput(std::string target);
    void write(const std::string& text) const;

private:
    std::string target_;
};

/// A folder for results, made if it is missing and locked against a second run while this lives.
class OutputFolder {
public:
    /// Throws app::Failure (outputFailed) where it cannot be made, written to, or is in use.
    explicit OutputFolder(std::filesystem::path folder);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return folder_; }

private:
    std::filesystem::path folder_, lockFile_;
    int lock_ = -1;
};

/// A name from a scene as a file name of at most 64 bytes: letters of every script, digits, '-' and '_' in
/// UTF-8; whatever else becomes '_'. Never empty.
std::string fileName(const std::string& name);

} // namespace sinew::tools
