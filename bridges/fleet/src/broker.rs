//! The MQTT broker: a connection that comes again whenever it broke.

use std::time::Duration;

use anyhow::{Context, bail};
use rumqttc::{AsyncClient, Event, EventLoop, MqttOptions, Packet, QoS};
use tokio::sync::mpsc::UnboundedSender;

use crate::heard::Heard;

/// Messages larger than this break the connection.
const LARGEST: usize = 16 << 20;

/// How long to wait before a broker is tried again.
const PAUSE: Duration = Duration::from_millis(500);

/// What vehicles say.
const TOPICS: [&str; 3] = ["connection", "state", "factsheet"];

/// Where the broker is: `mqtt://[USER[:PASSWORD]@]HOST[:PORT]`.
pub fn options(url: &str, id: &str) -> anyhow::Result<MqttOptions> {
    let Some(rest) = url.strip_prefix("mqtt://") else {
        bail!("`{url}` is no address of a broker: expected `mqtt://[USER[:PASSWORD]@]HOST[:PORT]`");
    };
    let (user, place) =
        rest.trim_end_matches('/').rsplit_once('@').map_or((None, rest), |(user, place)| (Some(user), place));
    let place = place.trim_end_matches('/');
    let (host, port) = match place.rsplit_once(':') {
        Some((host, port)) => {
            (host, port.parse().with_context(|| format!("`{port}` in `{url}` is no port"))?)
        }
        None => (place, 1883),
    };
    anyhow::ensure!(!host.is_empty(), "`{url}` names no host");
    let mut options = MqttOptions::new(id, host.trim_matches(['[', ']']), port);
    options.set_keep_alive(Duration::from_secs(15)).set_max_packet_size(LARGEST, LARGEST);
    if let Some(user) = user {
        let (name, password) = user.split_once(':').unwrap_or((user, ""));
        options.set_credentials(name, password);
    }
    Ok(options)
}

/// Refuses what cannot be the first part of topics.
pub fn expect_topic(interface: &str) -> anyhow::Result<()> {
    let is_level = |level: &str| !level.is_empty() && !level.contains(['+', '#', '\0']);
    anyhow::ensure!(
        interface.split('/').all(is_level),
        "`--interface` is `{interface}`, with which no topic can begin: expected names with `/` between them, without `+` and `#`"
    );
    Ok(())
}

/// Says how the connection is, and what comes over it, as long as anybody listens.
pub async fn hear(
    client: AsyncClient,
    mut events: EventLoop,
    interface: String,
    heard: UnboundedSender<Heard>,
) {
    let mut is_up = None;
    // subscriptions that the broker has not confirmed: what is published before it has them is not heard
    let mut asked = 0;
    loop {
        let say = match events.poll().await {
            Ok(Event::Incoming(Packet::ConnAck(_))) => {
                is_up = Some(true);
                // asked for on each connection: the broker may have forgotten
                for topic in TOPICS {
                    let all = format!("{interface}/+/+/+/{topic}");
                    // the queue is empty here
                    let _ = client.try_subscribe(all, QoS::AtLeastOnce);
                }
                asked = TOPICS.len();
                continue;
            }
            Ok(Event::Incoming(Packet::SubAck(_))) if asked > 0 => {
                asked -= 1;
                if asked > 0 {
                    continue;
                }
                Heard::Broker(None)
            }
            Ok(Event::Incoming(Packet::Publish(message))) => {
                Heard::Message(message.topic, message.payload.to_vec())
            }
            Ok(_) => continue,
            Err(error) => {
                let was = is_up.replace(false);
                if was != Some(false) && heard.send(Heard::Broker(Some(error.to_string()))).is_err() {
                    return;
                }
                tokio::time::sleep(PAUSE).await;
                continue;
            }
        };
        if heard.send(say).is_err() {
            return;
        }
    }
}
