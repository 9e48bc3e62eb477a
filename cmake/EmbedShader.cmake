# Writes one SPIR-V file as C++, packed: CMake itself makes a gzip file, of which the stream of deflate is embedded. It has no
# time of its making, so that two builds with the same CMake have the same bytes.
#   cmake -DSPIRV=.. -DOUTPUT=.. -DNAMESPACE=.. -DIDENTIFIER=.. -DNAME=.. -P EmbedShader.cmake
file(SIZE ${SPIRV} size)
math(EXPR words "${size} / 4")
file(ARCHIVE_CREATE OUTPUT ${OUTPUT}.gz PATHS ${SPIRV} FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
file(READ ${OUTPUT}.gz packed HEX)
file(REMOVE ${OUTPUT}.gz)
if(NOT packed MATCHES "^1f8b0800") # a head of 10 bytes, without a name
    message(FATAL_ERROR "CMake has made another kind of gzip file of ${SPIRV}")
endif()
string(LENGTH ${packed} length)
math(EXPR length "${length} - 20 - 16") # the tail holds a checksum and the size
string(SUBSTRING ${packed} 20 ${length} packed)
string(REGEX REPLACE "(..)" "0x\\1," bytes ${packed})
string(REGEX REPLACE "(....................................................................................................)" "\\1\n    " bytes ${bytes})
file(WRITE ${OUTPUT}
"#include \"sinew/vk/shader_code.hpp\"

namespace ${NAMESPACE} {
namespace vk = ::sinew::vk;
static const std::uint8_t ${IDENTIFIER}Bytes[] = {
    ${bytes}};
extern const vk::ShaderCode ${IDENTIFIER};
const vk::ShaderCode ${IDENTIFIER}{\"${NAME}\", {}, ${IDENTIFIER}Bytes, ${words}};
} // namespace ${NAMESPACE}
")
