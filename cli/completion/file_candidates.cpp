#include "cli/completion/file_candidates.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace burnish {

std::vector<Candidate> fileCandidates(const std::string& word, const std::vector<std::string>& endings) {
  namespace fs = std::filesystem;
  const std::size_t slash = word.rfind('/');
  const std::string place = slash == std::string::npos ? "" : word.substr(0, slash + 1);
  const std::string begun = word.substr(place.size());
  std::vector<Candidate> found;
  std::error_code status;
  for (fs::directory_iterator entry(place.empty() ? "." : place, status), end; !status && entry != end;
       entry.increment(status)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.') && !begun.starts_with('.')) continue;
    std::error_code unknown;
    if (entry->is_directory(unknown))
      found.push_back({place + name + "/", ""});
    else if (std::ranges::any_of(endings, [&](const std::string& ending) { return name.ends_with(ending); }))
      found.push_back({place + name, ""});
  }
  std::ranges::sort(found, {}, &Candidate::text);
  return found;
}

}  // namespace burnish
