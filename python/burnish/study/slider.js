"use strict";
for (const section of document.querySelectorAll(".compare")) {
  const pick = name => [...section.querySelectorAll(".store img")].find(image => image.dataset.name === name).src;
  const [left, right] = section.querySelectorAll("select");
  const slider = section.querySelector("input");
  const shown = { left: section.querySelector(".left"), right: section.querySelector(".right") };
  const bar = section.querySelector(".bar");
  const slide = () => {
    shown.left.style.clipPath = "inset(0 " + (100 - slider.value) + "% 0 0)";
    bar.style.left = slider.value + "%";
  };
  const choose = () => {
    shown.left.src = pick(left.value);
    shown.right.src = pick(right.value);
    slider.setAttribute("aria-valuetext", left.value + " against " + right.value);
  };
  slider.addEventListener("input", slide);
  left.addEventListener("change", choose);
  right.addEventListener("change", choose);
  choose();
  slide();
}
