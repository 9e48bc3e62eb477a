# Writes the bytes of files as C++: a table of names and bytes.
#   cmake -DFILES=.. -DOUTPUT=.. -DHEADER=.. -DNAMESPACE=.. -DTABLE=.. -P EmbedFile.cmake
set(arrays "")
set(rows "")
foreach(file ${FILES})
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes ${bytes})
    string(APPEND arrays "const unsigned char ${name}Bytes[] = {${bytes}};\n")
    string(APPEND rows "    {\"${name}\", ${name}Bytes},\n")
endforeach()
file(WRITE ${OUTPUT}
"#include \"${HEADER}\"

namespace ${NAMESPACE} {
namespace {
${arrays}
const EmbeddedFile rows[] = {
${rows}};
} // namespace
extern const std::span<const EmbeddedFile> ${TABLE};
const std::span<const EmbeddedFile> ${TABLE}{rows};
} // namespace ${NAMESPACE}
")
