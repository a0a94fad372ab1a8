//! From a folder of files to an answer, as a newcomer meets it: everything is drawn here, of an arm
//! that is in the repository, and the truth is known.

mod clouds;
mod doors;
mod in_memory;
mod recording;
mod refusals;
mod robots;
mod run;
mod scene;
mod trusted;
