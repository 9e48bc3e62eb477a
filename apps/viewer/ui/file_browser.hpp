// Folders and the files in them that the viewer opens, without drawing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sinew::viewer {

/// A line of the list.
struct FileEntry {
    enum class Kind { folder, scene, mesh, state };
    Kind kind = Kind::folder;
    std::string name; ///< as shown
    std::filesystem::path path;
    bool isRecent = false; ///< opened in an earlier run or before; not of the folder
};

/// Text that is typed chooses among the entries of a folder; a text with a slash names another folder. One
/// thread; reads a folder when it is entered, and waits for the disk meanwhile.
class FileBrowser {
public:
    /// Shows `folder` and before its entries the `recent` files, newest first.
    void open(const std::filesystem::path& folder, const std::vector<std::string>& recent);

    /// Leaves the entries whose name contains the text behind its last slash, in either case. Chooses the one
    /// of just that name, else the first; none if that text is empty.
    void filter(const std::string& text);
    const std::vector<FileEntry>& shown() const { return shown_; }
    const std::filesystem::path& folder() const { return folder_; }
    /// Why the folder has no entries; empty = it was read.
    const std::string& complaint() const { return complaint_; }

    /// Chooses the entry `by` lines further, from the end to the start and back.
    void move(int by);
    /// Index of the chosen entry.
    std::optional<std::size_t> chosen() const { return chosen_; }

    /// The file of an entry; none for a folder, which is entered.
    std::optional<std::string> take(std::size_t entry);
    /// The choice of Enter: the path that was typed if it is a file, else the chosen entry, else the path.
    std::optional<std::string> takeTyped();

private:
    void enter(const std::filesystem::path& folder);
    void choose(const std::string& part);

    std::filesystem::path home_, folder_; // of open(); of the list
    std::vector<FileEntry> recent_, all_, shown_;
    std::string text_, complaint_;
    std::optional<std::size_t> chosen_;
    bool isMoved_ = false; // chosen by move()
};

/// The kind of a file by the end of its name; empty = the viewer does not open it.
std::optional<FileEntry::Kind> kindOfFile(const std::filesystem::path& file);

/// The folder of the file that was opened last, if it still exists, else the current one.
std::filesystem::path startFolder(const std::vector<std::string>& recent);

/// Expands ~/ like a shell.
std::string expanded(const std::string& path);

} // namespace sinew::viewer
