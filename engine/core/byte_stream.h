#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// What goes from one process to another as bytes.
namespace burnish::inline core {

/// Takes, or fills, so many bytes.
using TakeBytes = std::function<void(const void* bytes, std::size_t count)>;
using FillBytes = std::function<void(void* bytes, std::size_t count)>;

void send(std::int64_t number, const TakeBytes& take);
void send(const std::string& text, const TakeBytes& take);
void send(const std::vector<double>& numbers, const TakeBytes& take);

std::int64_t receiveNumber(const FillBytes& fill);
std::string receiveText(const FillBytes& fill);
std::vector<double> receiveNumbers(const FillBytes& fill);

}  // namespace burnish::inline core
