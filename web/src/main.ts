import { mount } from "svelte";
import Player from "./Player.svelte";
import Plots from "./plots/Plots.svelte";
import { offerFolds } from "./folds";
import { Report } from "./report";
import "./style.css";
import { offerThemes } from "./theme";
import { shareTime } from "./time/shared.svelte";

const byId = (id: string): HTMLElement => document.getElementById(id)!;

offerThemes(byId("theme"));
offerFolds();
const report = new Report(JSON.parse(byId("data").textContent!));
shareTime(report.clock);
mount(Player, { target: byId("stage"), props: { report } });
mount(Plots, { target: byId("plots"), props: { report } });
