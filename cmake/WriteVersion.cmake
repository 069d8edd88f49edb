# Fills a template with the version and a digest of the engine's sources, so that a result tells which engine
# made it. Run at build time: cmake -DENGINE=… -DTEMPLATE=… -DOUTPUT=… -DBURNISH_VERSION=… -P WriteVersion.cmake
file(GLOB_RECURSE sources RELATIVE "${ENGINE}" "${ENGINE}/*.h" "${ENGINE}/*.cpp")
list(SORT sources)
set(digests "")
foreach(source IN LISTS sources)
  file(SHA256 "${ENGINE}/${source}" digest)
  string(APPEND digests "${source} ${digest}\n")
endforeach()
string(SHA256 digest "${digests}")
string(SUBSTRING "${digest}" 0 8 BURNISH_ENGINE_DIGEST)
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
