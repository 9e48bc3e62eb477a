# Writes one SPIR-V file as C++.
#   cmake -DSPIRV=.. -DOUTPUT=.. -DNAMESPACE=.. -DIDENTIFIER=.. -DNAME=.. -P EmbedShader.cmake
file(READ ${SPIRV} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words ${bytes}) # the words are little-endian
string(REGEX REPLACE "(0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,)" "\\1\n    " words ${words})
file(WRITE ${OUTPUT}
"#include \"sinew/vk/shader_code.hpp\"

namespace ${NAMESPACE} {
namespace vk = ::sinew::vk;
static const std::uint32_t ${IDENTIFIER}Words[] = {
    ${words}};
extern const vk::ShaderCode ${IDENTIFIER};
const vk::ShaderCode ${IDENTIFIER}{\"${NAME}\", ${IDENTIFIER}Words};
} // namespace ${NAMESPACE}
")
