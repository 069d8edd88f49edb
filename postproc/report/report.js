"use strict";
const frame = document.getElementById("frame");

/** Shows the picture and the time that the slider stands at. */
function showFrame() {
  const pictures = [...document.querySelectorAll("#frames img")];
  pictures.forEach((picture, k) => { picture.hidden = k !== Number(frame.value); });
  document.getElementById("time").textContent = pictures[frame.value].dataset.time;
}

if (frame) {
  frame.addEventListener("input", showFrame);
  showFrame();  // a browser keeps the slider's place when a page is loaded again
}
