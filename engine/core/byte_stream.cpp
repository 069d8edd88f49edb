#include "engine/core/byte_stream.h"

namespace burnish::inline core {

void send(std::int64_t number, const TakeBytes& take) {
  take(&number, sizeof(number));
}

void send(const std::string& text, const TakeBytes& take) {
  send(static_cast<std::int64_t>(text.size()), take);
  take(text.data(), text.size());
}

void send(const std::vector<double>& numbers, const TakeBytes& take) {
  send(static_cast<std::int64_t>(numbers.size()), take);
  take(numbers.data(), numbers.size() * sizeof(double));
}

std::int64_t receiveNumber(const FillBytes& fill) {
  std::int64_t number = 0;
  fill(&number, sizeof(number));
  return number;
}

std::string receiveText(const FillBytes& fill) {
  std::string text(static_cast<std::size_t>(receiveNumber(fill)), '\0');
  fill(text.data(), text.size());
  return text;
}

std::vector<double> receiveNumbers(const FillBytes& fill) {
  std::vector<double> numbers(static_cast<std::size_t>(receiveNumber(fill)));
  fill(numbers.data(), numbers.size() * sizeof(double));
  return numbers;
}

}  // namespace burnish::inline core
