// Draws the map of the chosen model. Plotly, before it on the page, fetches nothing for such charts.
(() => {
  const map = document.getElementById("map");
  const choice = document.getElementById("map-model");
  const { models } = JSON.parse(document.getElementById("map-data").textContent);
  const options = {
    responsive: true,
    displaylogo: false,
    // named one by one, so that none of a later plotly sends the map anywhere
    modeBarButtons: [["toImage", "zoom2d", "pan2d", "zoomIn2d", "zoomOut2d", "resetScale2d"]],
    toImageButtonOptions: { filename: "stability-map", scale: 2 },
  };
  const draw = () => {
    const { label, figure } = models[choice.value];
    map.setAttribute("aria-label", `Growth rate and critical speed of ${label} over incidence and speed`);
    return Plotly.react(map, figure.data, figure.layout, options);
  };
  models.forEach(({ label }, place) => choice.add(new Option(label, place)));
  choice.value = Math.max(0, models.findIndex(({ name }) => name === choice.dataset.first));
  choice.addEventListener("change", draw);
  document.getElementById("map-controls").hidden = models.length < 2;
  draw();
})();
