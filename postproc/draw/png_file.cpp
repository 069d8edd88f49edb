#include "postproc/draw/png_file.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <span>

#include "engine/results/atomic_file.h"

namespace burnish {

void writePng(vtkImageData& picture, const std::filesystem::path& file) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&picture);
  writer->SetCompressionLevel(5);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray& bytes = *writer->GetResult();
  const auto size = static_cast<std::size_t>(bytes.GetNumberOfValues());
  writeFileAtomically(file, std::as_bytes(std::span(bytes.GetPointer(0), size)));
}

}  // namespace burnish
