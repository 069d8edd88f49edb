#include "postproc/text/json_text.h"

#include <json/writer.h>

namespace burnish {

std::string compactText(const Json::Value& value, int digits) {
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "";
  builder["precision"] = digits;
  return Json::writeString(builder, value);
}

std::string scriptText(const Json::Value& value, int digits) {
  std::string json = compactText(value, digits);
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) json.replace(at, 1, "\\u003c");
  return json;
}

}  // namespace burnish
